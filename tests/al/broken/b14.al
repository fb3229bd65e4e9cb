; turn the crank a little: the rotor must run freely
        TRANS   CRANK [26 38 4 90 90 0]
        TRANS   ROTOR [25 38 4 90 90 0]
        OPEN    1
        MOVE    CRANK
        CLOSE   .1
        STOP    40
        TURN    ROTOR 600       ;a sixth of a turn
        SKIPE   23              ;it should meet no such resistance
        WAIT    "the rotor is hard to turn"
        OPEN    1
        CHANGE  Z 2
