; dialect of 1977, counter
        OPEN    1
        MOVE    P1
        ASSIGN  TRIES,3
AGAIN:  CLOSE   .1
        SKIPE   2
        JUMP    OK
        OPEN    1
        CHANGE  Z,-0.1,NIL,0,0
        SOJG    AGAIN,TRIES
        WAIT    NO PIN
OK:     CHANGE  Z,1.5,NIL,0,0
        PARK
