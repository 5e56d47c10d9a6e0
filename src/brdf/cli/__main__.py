"""`python -m brdf.cli`: the command line where the `brdf` command is not on the path."""

from . import main

if __name__ == "__main__":
    main()
