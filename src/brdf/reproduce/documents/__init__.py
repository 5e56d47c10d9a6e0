"""The documents whose results are made again, one module each. The folder is the list.

A module has TITLE (one line), SOURCE (the document), SETTINGS with the keys "full" and "quick", and
run(report, settings), which adds its figures, tables and claims to the `Report`.
"""
