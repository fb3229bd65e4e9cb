; three tries to get hold of the pin, then call somebody
        TRANS   P [24 32 7 90 90 0]
        TRANS   PARK [20 28 8 90 90 0]
        OPEN    1
        MOVE    P
AGAIN:  ASSIGN  TRIES 3
        CLOSE   .1
        SKIPE   2               ;nothing is between the fingers
        JUMP    GOT
        OPEN    1
        CHANGE  Z -.2
        SOJG    TRIES AGAIN
        WAIT    "nothing to grasp"
GOT:    PARK
