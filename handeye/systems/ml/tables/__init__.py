"""The thirty tables of MOS, which can be read and written while the machine runs."""
