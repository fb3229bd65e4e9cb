"""The task of the insertion bench: insert one pin into one hole."""
