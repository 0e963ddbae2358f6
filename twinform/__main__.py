"""`python -m twinform`: the same as the command."""

from twinform.cli import program

if __name__ == "__main__":
    program()
