"""The tables of a machine by cycle: recorded, shown as text, and shown in pages."""
