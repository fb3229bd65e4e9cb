"""Laying a plan open: its stages and times, its flow, what a change in a script did to it."""
