"""The TRIG language: programs that are taught by doing the task, displayed as they grow, and run forwards or
backwards at any moment [MIT, 1982].
"""
