"""Jobs on mesh files and USD, done in a confined child process: the messages, the process, and the geometry."""
