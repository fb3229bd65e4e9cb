"""The worlds of the pump: the nominal figures, the errors that vary, and the values of one world."""
