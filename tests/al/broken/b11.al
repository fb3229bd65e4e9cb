; push the cap on, but do not let it turn under the hand
        TRANS   CAP [24 32 7 90 90 0]
        TRANS   BODY [25 38 4 90 90 0]
        VECT    DOWN [0 0 -50]
        OPEN    2
        MOVE    CAP
        CLOSE   .8 1.2
        MOVE    BODY
        STOP    DOWN [0 0 .2]   ;50 oz, or 20 oz-in about the vertical
        CHANGE  DOWN .6
        SKIPN   23
        WAIT    "the cap met nothing"
        OPEN    2
        CHANGE  Z 2
