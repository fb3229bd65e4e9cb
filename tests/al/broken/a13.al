; in two stages
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        STAGE   "fetch the screw
        OPEN    1
        MOVE    P
        CLOSE   .1
        STAGE   "put it down"
        MOVE    T
        PLACE
        OPEN    1
