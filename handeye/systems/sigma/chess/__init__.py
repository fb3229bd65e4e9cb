"""The chess experiment of the paper: pieces are found, measured, and put on the line for their height."""
