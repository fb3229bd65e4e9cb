        TRANS   PEG [18 40 3 90 90 0]
        TRANS   HOLE [25 36 4 90 90 0]
        OPEN    1
        MOVE    PEG
        CLOSE   .1
        SKIPN   2
            OPEN    1
            WAIT    "NO PEG"
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1.5
        OPEN    1
        CHANGE  [0 0 1] 2
        PARK
