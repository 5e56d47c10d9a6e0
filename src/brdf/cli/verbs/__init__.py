"""The verbs, one a file: each module gives a function `command` and is called as the verb."""
