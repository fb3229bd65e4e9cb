        TRANS   PEG [18 40 3 90 90 0]
        TRANS   HOLE [28 34 4 90 90 0]
        OPEN    1
        MOVE    PEG
        CLOSE   .1
        VIA     [23 30 9 90 90 0]
        MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1.5
        OPEN    1
        PARK
