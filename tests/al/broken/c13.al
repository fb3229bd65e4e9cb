; hold check at the very end
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1.2
        SKIPN   23
        WAIT    "no hole"
        CLOSE   .1
        SKIPN   2
