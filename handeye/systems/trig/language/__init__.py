"""The TRIG language: programs that are taught by doing, drawn as they grow, and run forwards or backwards at any
moment [MIT, 1982].
"""
