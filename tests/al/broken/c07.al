; dialect of 1977
        VECT    FV [0 0 -50]
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  Z,1.5,NIL,0,0
        MOVE    T1
        FREE    X,Y
        STOP    FV,NIL
        CHANGE  Z,-1.2,NIL,0,0
        SKIPN   23
        WAIT    NO HOLE
        OPEN    1
        PARK
