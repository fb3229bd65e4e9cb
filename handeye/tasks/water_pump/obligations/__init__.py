"""Lists the obligations of the pump's programs. For each finding of the referee, a program must show certain claims
before it may end.
"""
