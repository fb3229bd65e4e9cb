; three tries for a nut
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1
        MOVE    P
AGAIN:  ASSIGN  TRIES 3
        CLOSE   .1
        SKIPE   2
        JUMP    GOT
        OPEN    1
        CHANGE  Z -.3
        SOJG    TRIES AGAIN
        WAIT    "no nut in the tray"
GOT:    MOVE    T
        OPEN    1
