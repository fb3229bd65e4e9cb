"""Machines behind the bus that need no physics."""
