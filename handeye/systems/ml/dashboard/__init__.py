"""Records the tables of a machine in each cycle, and shows them as text and in pages."""
