"""The site of the documentation: built from the pages of `docs/` by Sphinx, for `python3 run.py docs`."""
