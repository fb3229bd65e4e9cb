"""Editor services for the arm language: functions that work on a text, and a language server that uses them."""
