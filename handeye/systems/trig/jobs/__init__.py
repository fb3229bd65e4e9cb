"""The bench for TRIG's examples: blocks on the platter of a Purbrick arm."""
