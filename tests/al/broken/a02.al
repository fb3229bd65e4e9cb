; fetch two washers, one after the other
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1.5
        MOVE    P               ;the first
        CLOSE   .05
        MOVE    T
        OPEN    1.5
        MOVE    p               ;the second
        CLOSE   .05
        MOVE    T
        OPEN    1.5
