"""Jobs on mesh files, done in a confined child process: the messages, the process, and the geometry."""
