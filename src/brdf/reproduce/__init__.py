"""The results of the source documents, made again: one module a document, our numbers beside theirs."""
