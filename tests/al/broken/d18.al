        TRANS   PEG [18 40 3 90 90 0]
        TRANS   SPOT [28 34 4 90 90 0]
        OPEN    1
        MOVE    PEG
        CLOSE   .1
        CHANGE  [0 0 1] 2
        MOVE    SPOT
        TOUCH   3
        CHANGE  [0 0 -1] 1.5
        SKIPN   25
        WAIT    "NO PLATE"
        OPEN    1
        CHANGE  [0 0 1] 2
        PARK
