"""Commands of TRIG."""
