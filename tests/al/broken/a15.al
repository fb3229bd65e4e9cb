; two pins, the same way twice
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1
        MOVE    P
        CLOSE   .1
        SKIPE   2
        JUMP    GOT
        WAIT    "no first pin"
GOT:    MOVE    T
        OPEN    1
        MOVE    P
        CLOSE   .1
        SKIPE   2
        JUMP    GOT
        WAIT    "no second pin"
GOT:    MOVE    T
        OPEN    1
