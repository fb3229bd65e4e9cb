"""Editor services of the language: pure functions on a text, and a language server on top of them."""
