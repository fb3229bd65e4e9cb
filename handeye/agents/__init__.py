"""What agents use: a server of tools for the model context protocol, and the bench that judges agents' programs."""
