"""From a document to validated text, and text into files: the back ends."""
