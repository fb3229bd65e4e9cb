"""The bench of TRIG's examples: blocks on the platter of a Purbrick arm."""
