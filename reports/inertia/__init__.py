"""Which inertias do engines refuse, and are they content once they are mended?"""
