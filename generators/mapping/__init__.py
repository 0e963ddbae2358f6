"""Where does every element and attribute of both formats go?"""
