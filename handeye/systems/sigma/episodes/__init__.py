"""The chess experiment as a Gymnasium environment."""
