"""Readers that are generated from the facts tables and the IR's classes: from an XML tree to nodes, without a detour.

`urdf.py` and `sdf.py` are written by `generate.py`. They read what is usual; all else goes, part by part, to the schema
reader, which reports the findings and puts what it reads into the same dict.
"""
