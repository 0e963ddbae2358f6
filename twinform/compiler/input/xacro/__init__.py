"""The process that expands one xacro file: it is started by a script, and knows nothing of the compiler.

xacro keeps its state in its modules, patches the XML library of Python, and evaluates expressions. Here all that
happens where it can do no harm: expressions are interpreted (`interpreter`), files, packages and environment variables
are asked for (`channel`), and before the first file arrives the process gives up all that it does not need
(`confinement`).
"""
