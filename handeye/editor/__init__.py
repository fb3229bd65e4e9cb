"""Editor services for the arm language: pure functions on a text, and a language server that uses them."""
