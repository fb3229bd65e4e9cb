"""Runs stepped by people: commands, breakpoints, views."""
