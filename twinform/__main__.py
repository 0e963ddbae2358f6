"""`python -m twinform`: the same as the command, but Python looks for modules in the current folder first.

In a folder of somebody else use the command, or `python -P -m twinform`.
"""

from twinform.cli import program

if __name__ == "__main__":
    program()
