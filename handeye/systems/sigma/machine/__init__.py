"""Machines behind the bus interface that need no physics."""
