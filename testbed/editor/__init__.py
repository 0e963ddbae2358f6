"""An editor that talks to the language server."""
