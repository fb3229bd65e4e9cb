"""The checked program and its model of the cell. Both are independent of the program's language and of the arm."""
