"""Makes what is committed and generated: schemas, tables of code, reference pages; and pictures of the documents."""
