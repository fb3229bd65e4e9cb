"""The worlds of the pump: nominal figures, the errors that vary, and the values of one world."""
