; fetch the pin; it may stand a little lower than taught
        TRANS   P [18 44 3 90 90 0]
        TRANS   T [25 38 4 90 90 0]
        OPEN    1
        MOVE    P
AGAIN:  CLOSE   .1
        SKIPE   2               ;nothing between the fingers
        JUMP    GOT
        OPEN    1
        CHANGE  Z -.3           ;look a little lower
        JUMP    AGAIN
        WAIT    "there is no pin in the holder"
GOT:    MOVE    T
        OPEN    .5
