"""Printers: one module a target language, each turning a traced program into source text."""
