; fetch a screw, but not a fat one
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        TRANS   PARK [20 30 12 90 90 0]
        OPEN    1
        MOVE    P
        CLOSE   .2
        SKIPN   7
        WAIT    "this screw is too thick"
        MOVE    T
        OPEN    1
        PARK
