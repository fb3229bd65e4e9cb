"""The chess experiment of the paper: pieces are found, measured, and put on the line of their height."""
