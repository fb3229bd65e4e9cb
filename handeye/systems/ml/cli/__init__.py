"""The commands of MOS and ML."""
