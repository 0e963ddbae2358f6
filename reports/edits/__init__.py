"""Is what stands in a file what counts? Edits and passes on converted files."""
