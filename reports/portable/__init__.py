"""Do all loaders take a file that was converted with `--for portable`? Every readable URDF, before and after."""
