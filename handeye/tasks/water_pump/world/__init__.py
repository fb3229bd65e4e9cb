"""The worlds of the pump: its figures as drawn, the errors that vary, and what one drawn world is."""
