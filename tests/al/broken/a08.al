; lay the gasket down and hold it there
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1
        MOVE    P
        CLOSE   .2
        FORCE   [0 0 -8]        ;press it on
        MOVE    T
        CHANGE  [0 0 -1] .5
        OPEN    1
