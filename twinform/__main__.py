"""`python -m twinform`: the same as the command."""

from twinform.cli import main

if __name__ == "__main__":
    main()
