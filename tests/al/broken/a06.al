; try three heights for the pin
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        ASSIGN  TRIES 3
        OPEN    1
        MOVE    P
AGIAN:  CLOSE   .1
        SKIPE   2
        JUMP    GOT
        OPEN    1
        CHANGE  Z -.3
        SOJG    TRIES AGAIN
        WAIT    "no pin in the tray"
GOT:    MOVE    T
        OPEN    1
