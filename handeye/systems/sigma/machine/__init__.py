"""Machines that are simulated without physics. Programs reach them through the bus interface."""
