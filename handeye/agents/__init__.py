"""Serves agents: a server offers them tools over the model context protocol, and a bench judges their programs."""
