"""The rules, one file for each stage of the compiler."""
