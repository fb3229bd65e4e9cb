; take the rod, which may stand a little lower than it should
        TRANS   ROD [24 36 4.5 90 90 0]
        OPEN    1
        MOVE    ROD
AGAIN:  ASSIGN  TRIES 3
        CLOSE   .2
        SKIPE   2               ;nothing there
        JUMP    GOT
        OPEN    1
        CHANGE  Z -.3
        SOJG    TRIES AGAIN
        WAIT    no rod to be found
GOT:    CHANGE  Z 2
        PARK
