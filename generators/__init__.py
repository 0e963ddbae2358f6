"""Makes what is committed and generated: schemas, tables of code, reference pages; and the pictures of the documents."""
