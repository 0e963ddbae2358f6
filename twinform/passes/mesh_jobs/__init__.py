"""Jobs on mesh files, which a confined child process does: what goes there, what comes back, and the work itself."""
