"""Checks of a program whose form is right."""
