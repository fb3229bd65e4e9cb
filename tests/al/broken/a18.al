; seat the bearing
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    2
        MOVE    P
        CLOSE   .75
        MOVE    T
        STOP    [0 0 -6000]
        CHANGE  [0 0 -1] 1
        SKIPN   23
        WAIT    "the bearing did not seat"
        OPEN    2
