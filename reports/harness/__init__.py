"""What every report needs: models, processes, known causes, Markdown, the command line."""
