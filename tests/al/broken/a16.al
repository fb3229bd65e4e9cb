; the housing is wide
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        STAGE   "bring the housing"
        OPEN    4.5
        MOVE    P
        CLOSE   2.5
        MOVE    T
        OPEN    4
