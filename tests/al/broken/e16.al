        STAGE   "take a pin"
        OPEN    1
        MOVE    P2
        CLOSE   .1
        JUMP    GOT
        WAIT    "no pin in the holder"
GOT:    CHANGE  [0 0 1] 1.5
        STAGE   "bring it"
        MOVE    T2
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        WAIT    "no hole"
        OPEN    1
        PARK
