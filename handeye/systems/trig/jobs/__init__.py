"""Blocks on the platter of a Purbrick arm: the bench on which TRIG's examples are carried out."""
