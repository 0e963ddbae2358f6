"""The framework of passes: what one is, pipelines as text and tables, options, the registry, instrumentation."""
