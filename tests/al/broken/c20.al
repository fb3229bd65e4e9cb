; feel softly
        OPEN    0
        MOVE    T1
        STOP    [0 0 -.2]
        CHANGE  [0 0 -1] 2
        SKIPN   23
        WAIT    "no pump"
        CHANGE  [0 0 1] 2
        PARK
